# The target meniscus_kernel.
meniscus_add_kernel_objects(meniscus_kernel)
# Whoever links the kernel also links the file that uses OpenMesh.
target_sources(meniscus_kernel INTERFACE $<TARGET_OBJECTS:meniscus_membrane_normals>)
target_link_libraries(meniscus_kernel INTERFACE OpenMeshCore)
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
    Volume/Packet/Data
    Volume/Rays
    Volume/Packet/Models
    Volume/Packet/Walk
    Volume/Packet/Kernels
    Volume/Graded
    Volume/Entries
    Volume/Refracted
    Volume/Caster
    Volume/Illumination
    Surface)
  add_subdirectory("${room}")
endforeach ()
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
