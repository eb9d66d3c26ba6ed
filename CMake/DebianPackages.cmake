# What CPack makes Debian packages of; Packaging/make-packages.sh runs it. The plugin for ParaView comes from a
# build tree of its own, so it is the only package of that tree.

if (NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "Debian packages are installed to /usr, not to ${CMAKE_INSTALL_PREFIX}")
endif ()

set(vtkirradiance_library_package libvtkfiltersirradiance1)

# vtkirradiance_package(COMPONENT NAME SECTION CONTENTS DEPENDS): one component is one package.
macro (vtkirradiance_package component name section contents depends)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${name}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${section}")
  set(CPACK_DEBIAN_${upper}_DESCRIPTION
    "vtkIrradiance computes the irradiance (W/m2) of every cell of polygonal
geometry by photon walks, and keeps it up to date as things move: only
walks that a motion changed are shot again.
.
This package holds ${contents}.")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  install(FILES "${PROJECT_SOURCE_DIR}/Packaging/copyright" "${PROJECT_BINARY_DIR}/changelog.gz"
      "${PROJECT_BINARY_DIR}/CHANGELOG.md.gz"
    DESTINATION "share/doc/${name}" COMPONENT ${component})
endmacro ()

# Debian wants an address with a name. home.arpa (RFC 8375) is nobody's.
set(CPACK_PACKAGE_CONTACT "vtkIrradiance contributors <maintainers@vtkirradiance.home.arpa>")
# changelog.gz has Debian's form; the project's own changelog stands beside it.
find_program(GZIP_PROGRAM gzip REQUIRED)
configure_file("${PROJECT_SOURCE_DIR}/Packaging/changelog.in" "${PROJECT_BINARY_DIR}/changelog" @ONLY)
configure_file("${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_BINARY_DIR}/CHANGELOG.md" COPYONLY)
foreach (document IN ITEMS changelog CHANGELOG.md)
  execute_process(COMMAND "${GZIP_PROGRAM}" -9nc "${PROJECT_BINARY_DIR}/${document}"
    OUTPUT_FILE "${PROJECT_BINARY_DIR}/${document}.gz" COMMAND_ERROR_IS_FATAL ANY)
endforeach ()

set(CPACK_COMPONENTS_ALL)
# Where libraries lie, while packages are made, that no installed package has.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
# vtkirradiance_same_minor(VARIABLE PACKAGE VERSION): PACKAGE of this version, or with later corrections of it
function (vtkirradiance_same_minor variable package version)
  string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" minor "${version}")
  math(EXPR next "${CMAKE_MATCH_2} + 1")
  set(${variable} "${package} (>= ${minor}), ${package} (<< ${CMAKE_MATCH_1}.${next})" PARENT_SCOPE)
endfunction ()

if (VTKIRRADIANCE_BUILD_PARAVIEW_PLUGIN)
  get_filename_component(libraries "${ParaView_DIR}/../.." ABSOLUTE)
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${libraries}")
  vtkirradiance_same_minor(paraview paraview "${ParaView_VERSION}")
  vtkirradiance_package(runtime paraview-vtkirradiance science
    "the plugin IrradiancePlugin for ParaView"
    "${paraview}")
else ()
  vtkirradiance_package(runtime ${vtkirradiance_library_package} libs "the shared library" "")
  # The library is found from now on, and not any more once it is gone.
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/Packaging/triggers")
  vtkirradiance_package(development libvtkirradiance-dev libdevel
    "the headers and the CMake package vtkIrradiance"
    "${vtkirradiance_library_package} (= ${PROJECT_VERSION}), libvtk9-dev")
  if (VTKIRRADIANCE_WRAP_PYTHON)
    vtkirradiance_same_minor(vtk python3-vtk9 "${VTK_VERSION}")
    vtkirradiance_same_minor(python python3 "${Python3_VERSION}")
    vtkirradiance_package(python python3-vtkirradiance python
      "the module vtkIrradiance for VTK's Python"
      "${vtkirradiance_library_package} (= ${PROJECT_VERSION}), ${vtk}, ${python}, python3-numpy")
    # What Python has compiled goes with the package.
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      "${PROJECT_SOURCE_DIR}/Packaging/python/postinst;${PROJECT_SOURCE_DIR}/Packaging/python/prerm")
  endif ()
endif ()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vtkirradiance)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Irradiance of every cell of a moving scene, for VTK")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)
