# The target meniscus_kernel.
add_library(meniscus_kernel OBJECT)
target_include_directories(meniscus_kernel
  PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}")
target_link_libraries(meniscus_kernel PUBLIC glm::glm OpenMeshCore)
# Also where the build around it has other ideas, as VTK's own, of C++11 up to 9.3.
target_compile_features(meniscus_kernel PUBLIC cxx_std_17)
set_property(TARGET meniscus_kernel PROPERTY POSITION_INDEPENDENT_CODE ON)
# Results are the same on every machine: no fused operations where the source has two.
# Nobody reads errno of mathematical functions: without it, roots and rounding are instructions.
target_compile_options(meniscus_kernel PRIVATE -ffp-contract=off -fno-math-errno)
# Its rooms, lowest first. ARCHITECTURE.md says which may include which.
foreach (room
    Common
    Simd
    Refraction/Membrane
    Refraction/Sight
    Refraction/Tubes
    Refraction/Surface
    Refraction/Flat
    Refraction/Curved
    Refraction/Stack
    Refraction/Images
    Refraction/StackImages
    Volume/Optics
    Volume/Mesh
    Volume/Division
    Volume/Graded
    Volume/Packet/Data
    Volume/Rays
    Volume/Packet/Models
    Volume/Packet/Walk
    Volume/Packet/Kernels
    Volume/Entries
    Volume/Refracted
    Volume/Caster
    Volume/Illumination
    Surface)
  add_subdirectory("${room}")
endforeach ()
meniscus_target_flags(meniscus_kernel)
meniscus_precompile_headers(meniscus_kernel kernel)
# Folders whose functions do not count in the time of a picture: inlining stays as it is elsewhere.
meniscus_compile_together(meniscus_kernel
  Module/Common
  Module/Surface
  Module/Refraction/Membrane
  Module/Refraction/Surface
  Module/Refraction/Flat
  Module/Refraction/Stack
  Module/Refraction/Images
  Module/Refraction/StackImages
  Module/Volume/Division
  Module/Volume/Mesh
  Module/Volume/Optics)
if (PROJECT_NAME STREQUAL "Meniscus") # for other build trees: MENISCUS_KERNEL_BUILD
  export(TARGETS meniscus_kernel FILE "${CMAKE_BINARY_DIR}/MeniscusKernel.cmake")
endif ()
