# Builds Modules/FiltersIrradiance as a VTK module and installs it as the package vtkIrradiance.

set(vtkirradiance_vtk_components
  CommonCore CommonDataModel CommonExecutionModel CommonMath CommonSystem CommonTransforms
  FiltersCore FiltersVerdict RenderingCore)
find_package(VTK 9.1 REQUIRED COMPONENTS ${vtkirradiance_vtk_components})

if (VTKIRRADIANCE_WRAP_PYTHON)
  # Debian's VTK is for Debian's Python, even where another one comes first in the PATH.
  if (VTK_DIR MATCHES "^/usr/lib/" AND EXISTS "/usr/bin/python3")
    set(Python3_EXECUTABLE "/usr/bin/python3" CACHE FILEPATH "The Python that has VTK")
  endif ()
  find_package(VTK 9.1 REQUIRED COMPONENTS Python WrappingPythonCore)
endif ()

set(vtkirradiance_cmake_dir "${CMAKE_INSTALL_LIBDIR}/cmake/vtkIrradiance")

vtk_module_scan(
  MODULE_FILES "${PROJECT_SOURCE_DIR}/Modules/FiltersIrradiance/vtk.module"
  PROVIDES_MODULES vtkirradiance_modules
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON
  ENABLE_TESTS OFF) # Testing/ has its own
vtk_module_build(
  MODULES ${vtkirradiance_modules}
  PACKAGE vtkIrradiance
  INSTALL_EXPORT vtkIrradiance
  TARGET_NAMESPACE vtkIrradiance
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/vtkIrradiance"
  CMAKE_DESTINATION "${vtkirradiance_cmake_dir}"
  ENABLE_WRAPPING "${VTKIRRADIANCE_WRAP_PYTHON}"
  VERSION "${PROJECT_VERSION}"
  SOVERSION 1) # 0 would be taken for "none"

include(CMakePackageConfigHelpers)
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/CMake/vtkIrradianceConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/vtkIrradianceConfig.cmake"
  INSTALL_DESTINATION "${vtkirradiance_cmake_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/vtkIrradianceConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${PROJECT_BINARY_DIR}/vtkIrradianceConfig.cmake"
    "${PROJECT_BINARY_DIR}/vtkIrradianceConfigVersion.cmake"
  DESTINATION "${vtkirradiance_cmake_dir}"
  COMPONENT development)
