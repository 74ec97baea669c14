# Builds the kernel and its unit tests alone: no VTK, no OpenGL. For other processors and quick
# work.
find_package(glm REQUIRED)
find_package(OpenMesh REQUIRED)
find_package(GTest REQUIRED)
include(GoogleTest)
enable_testing()
add_subdirectory(Module)
add_subdirectory(Testing/Reference/Refraction)
add_subdirectory(Testing/Fuzz)
add_subdirectory(Testing/Module)
