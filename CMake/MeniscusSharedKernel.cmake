# The kernel of the build folder MENISCUS_KERNEL_BUILD: it knows no VTK and can serve several hosts.
# It is built there, as part of this build.
if (NOT EXISTS "${MENISCUS_KERNEL_BUILD}/MeniscusKernel.cmake")
  message(FATAL_ERROR "MENISCUS_KERNEL_BUILD: ${MENISCUS_KERNEL_BUILD} is no build of Meniscus")
endif ()
include("${MENISCUS_KERNEL_BUILD}/MeniscusKernel.cmake")
set_property(TARGET meniscus_kernel PROPERTY IMPORTED_GLOBAL TRUE)
string(TOUPPER "${CMAKE_BUILD_TYPE}" _type)
get_target_property(_objects meniscus_kernel IMPORTED_OBJECTS_${_type})
if (NOT _objects)
  message(FATAL_ERROR "MENISCUS_KERNEL_BUILD: its build type is not ${CMAKE_BUILD_TYPE}")
endif ()
add_custom_target(meniscus_kernel_build
  COMMAND    "${CMAKE_COMMAND}" --build "${MENISCUS_KERNEL_BUILD}" --target meniscus_kernel
  BYPRODUCTS ${_objects}
  COMMENT    "Building the kernel in ${MENISCUS_KERNEL_BUILD}"
  USES_TERMINAL)
add_dependencies(meniscus_kernel meniscus_kernel_build)
