# Builds the kernel and its unit tests alone: no VTK, no OpenGL. For other processors, quick work,
# and as the kernel of several builds (MENISCUS_KERNEL_BUILD).
find_package(glm REQUIRED)
find_package(OpenMesh REQUIRED)
add_subdirectory(Module)
if (MENISCUS_BUILD_TESTING)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  enable_testing()
  add_subdirectory(Testing/Reference/Refraction)
  add_subdirectory(Testing/Fuzz)
  add_subdirectory(Testing/Module)
  meniscus_write_rooms()
endif ()
