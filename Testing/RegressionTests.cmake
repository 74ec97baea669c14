# Adds the folders regression_folders, which have regression images, to a build that is not VTK's
# own, as VTK's project Testing/External does: with the variables that vtk_module_build() would set.
set(ExternalData_SOURCE_ROOT "${CMAKE_CURRENT_LIST_DIR}")
set(ExternalData_OBJECT_STORES "${CMAKE_BINARY_DIR}/ExternalData/Objects")
set(_vtk_build_test Meniscus::Meniscus)
set(_vtk_build_test_labels image)
set(_vtk_build_TEST_DATA_TARGET MeniscusData)
set(_vtk_build_TEST_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/Testing/Temporary")
foreach (folder IN LISTS regression_folders)
  add_subdirectory("${CMAKE_CURRENT_LIST_DIR}/${folder}" ${folder})
endforeach ()
ExternalData_Add_Target(MeniscusData) # copies of the baselines in the build folder
