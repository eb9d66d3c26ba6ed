# Wraps the classes for Python and makes the package vtkIrradiance of them and of Modules/Python.

# Where Python looks: Debian calls the folder dist-packages, others site-packages.
execute_process(
  COMMAND "${Python3_EXECUTABLE}" -c "import sysconfig; print(sysconfig.get_path('platlib').rsplit('/', 1)[1])"
  OUTPUT_VARIABLE vtkirradiance_packages_name
  OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
set(VTKIRRADIANCE_PYTHON_DIR
  "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/${vtkirradiance_packages_name}"
  CACHE STRING "The folder of Python packages, below CMAKE_INSTALL_PREFIX")
set(vtkirradiance_python_package "${VTKIRRADIANCE_PYTHON_DIR}/vtkIrradiance")

# The extension module finds the library beside which it is installed.
file(RELATIVE_PATH vtkirradiance_to_library
  "/${vtkirradiance_python_package}" "/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${vtkirradiance_to_library}")
vtk_module_wrap_python(
  MODULES ${vtkirradiance_modules}
  PYTHON_PACKAGE vtkIrradiance
  MODULE_DESTINATION "${VTKIRRADIANCE_PYTHON_DIR}"
  BUILD_STATIC OFF
  INSTALL_HEADERS OFF
  TARGET vtkIrradiance::python)
unset(CMAKE_INSTALL_RPATH)

set(vtkirradiance_python_sources "${PROJECT_SOURCE_DIR}/Modules/Python")
set(vtkirradiance_python_build "${PROJECT_BINARY_DIR}/${vtkirradiance_python_package}")
configure_file("${vtkirradiance_python_sources}/__init__.py.in"
  "${vtkirradiance_python_build}/__init__.py" @ONLY)
set(vtkirradiance_python_files "${vtkirradiance_python_build}/__init__.py")
foreach (name IN ITEMS arrays groups pipeline processes)
  configure_file("${vtkirradiance_python_sources}/${name}.py"
    "${vtkirradiance_python_build}/${name}.py" COPYONLY)
  list(APPEND vtkirradiance_python_files "${vtkirradiance_python_build}/${name}.py")
endforeach ()
install(
  FILES ${vtkirradiance_python_files}
  DESTINATION "${vtkirradiance_python_package}"
  COMPONENT python)
