# usage: cmake -DROOT=<project> -P CheckTwins.cmake
# Files that have one algorithm in C++ and in GLSL name each other by lines at their tops:
#   // Twin: <path> (<subject>)
# Fails unless each of these paths exists and names its
# partner back.
cmake_minimum_required(VERSION 3.18)
file(GLOB_RECURSE files RELATIVE "${ROOT}"
  "${ROOT}/Module/*.h" "${ROOT}/Module/*.cxx" "${ROOT}/Rendering/*.h" "${ROOT}/Rendering/*.cxx"
  "${ROOT}/Rendering/*.glsl")
set(links)
foreach (file IN LISTS files)
  file(STRINGS "${ROOT}/${file}" lines REGEX "^// Twin: ")
  foreach (line IN LISTS lines)
    string(REGEX REPLACE "^// Twin: ([^ ]+) \\(.+\\)$" "\\1" partner "${line}")
    if (NOT EXISTS "${ROOT}/${partner}")
      message(SEND_ERROR "${file} names a twin that does not exist: ${line}")
    endif ()
    list(APPEND links "${file}>${partner}")
  endforeach ()
endforeach ()
foreach (link IN LISTS links)
  string(REPLACE ">" ";" ends "${link}")
  list(GET ends 0 file)
  list(GET ends 1 partner)
  if (NOT "${partner}>${file}" IN_LIST links)
    message(SEND_ERROR "${partner} does not name its twin ${file}")
  endif ()
endforeach ()

# The algorithms that are known to be written twice, and the parts of all blend modes.
include("${ROOT}/Module/Volume/Optics/BlendModes.cmake")
list(TRANSFORM meniscus_blend_mode_parts PREPEND Tetrahedra)
foreach (part PlateTransmittance TetrahedraRays TetrahedraWalk TetrahedraComponents
    TetrahedraMedium TetrahedraLights TetrahedraPreIntegrated TetrahedraTransferFunction
    TetrahedraPlaceFS TetrahedraEntryTiles MediumTransmittance TetrahedraFading
    ${meniscus_blend_mode_parts})
  if (NOT "${links}" MATCHES "Rendering/glsl/vtk${part}.glsl>Module/")
    message(SEND_ERROR "vtk${part}.glsl names no twin in Module/")
  endif ()
endforeach ()
list(LENGTH links number)
message(STATUS "${number} names of twins")
