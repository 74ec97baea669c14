# Builds the kernel and its unit tests alone: no VTK, no OpenGL. For other processors, quick work,
# and as the kernel of several builds (MENISCUS_KERNEL_BUILD).
find_package(glm REQUIRED)
if (MENISCUS_BUILD_TESTING)
  find_package(OpenMesh REQUIRED)
else ()
  find_package(OpenMesh QUIET) # the kernel's objects do not need it
endif ()
add_subdirectory(Module)
if (MENISCUS_BUILD_TESTING)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  enable_testing()
  add_subdirectory(Testing/Reference)
  add_subdirectory(Testing/Fuzz)
  add_subdirectory(Testing/Module)
  meniscus_write_rooms()
endif ()
