# meniscus_add_kernel_objects(TARGET [FILE...]): an object library of the kernel, plain C++17.
function (meniscus_add_kernel_objects target)
  add_library(${target} OBJECT ${ARGN})
  target_include_directories(${target}
    PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_BINARY_DIR}")
  target_link_libraries(${target} PUBLIC glm::glm)
  # Also where the build around it has other ideas, as VTK's own, of C++11 up to 9.3.
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_property(TARGET ${target} PROPERTY POSITION_INDEPENDENT_CODE ON)
  # Results are the same on every machine: no fused operations where the source has two.
  # Nobody reads errno of mathematical functions: without it, roots and rounding are instructions.
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno)
  meniscus_target_flags(${target})
endfunction ()

# The only file of the kernel that uses OpenMesh has a target of its own, which every build compiles
# for itself: the kernel of several builds (MENISCUS_KERNEL_BUILD) needs no OpenMesh. Scripts
# compile that kernel while OpenMesh's many packages are being installed.
if (TARGET OpenMeshCore)
  meniscus_add_kernel_objects(meniscus_membrane_normals Refraction/Membrane/MembraneNormals.cxx)
  target_link_libraries(meniscus_membrane_normals PUBLIC OpenMeshCore)
  # VTK's wheels have libstdc++'s old std::string, OpenMesh's library has the compiler's. The file
  # has no string in its interface, so that it can differ from the others.
  if (MENISCUS_VTK_HAS_OLD_STRINGS)
    target_compile_options(meniscus_membrane_normals
      PRIVATE -U_GLIBCXX_USE_CXX11_ABI -D_GLIBCXX_USE_CXX11_ABI=1)
  endif ()
endif ()
