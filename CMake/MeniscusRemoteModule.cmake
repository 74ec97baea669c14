# The body of the module inside a VTK build. VTK's own flags and output folders apply there.
# No test builds this way yet.
find_package(glm REQUIRED)
find_package(OpenMesh REQUIRED)
function (meniscus_target_flags)
endfunction ()
add_subdirectory(Module)
