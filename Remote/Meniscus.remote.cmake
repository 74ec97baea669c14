# To be copied to VTK's folder Remote/, with the address of a repository of this project: VTK then
# fetches it with -DVTK_MODULE_ENABLE_VTK_Meniscus=YES. A clone in Remote/Meniscus does without.
if (MENISCUS_GIT_REPOSITORY)
  vtk_fetch_module(Meniscus
    "Ray casting of tetrahedral meshes and virtual geometry behind refracting surfaces"
    GIT_REPOSITORY "${MENISCUS_GIT_REPOSITORY}"
    GIT_TAG        HEAD)
endif ()
