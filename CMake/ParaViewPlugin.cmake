# Builds Modules/FiltersIrradiance and Modules/ParaViewPlugin against ParaView's own VTK, in place of the
# module for another VTK: both would define targets of the same names.

# Named one by one, or ParaView's configuration asks for the development files of Qt, which a plugin
# without widgets of its own does not need.
find_package(ParaView 5.11 REQUIRED COMPONENTS
  ProcessXML RemotingClientServerStream RemotingCore RemotingServerManager VTKExtensionsCore WrapClientServer)

# The plugin is installed with its library; ParaView names no component for it.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
paraview_plugin_scan(
  PLUGIN_FILES "${PROJECT_SOURCE_DIR}/Modules/ParaViewPlugin/paraview.plugin"
  PROVIDES_PLUGINS vtkirradiance_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
# Installed to where ParaView looks for plugins, such as lib/paraview-5.11/plugins/IrradiancePlugin.
paraview_plugin_build(
  PLUGINS ${vtkirradiance_plugins}
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  PLUGINS_FILE_NAME irradiance.plugins.xml
  DISABLE_XML_DOCUMENTATION ON)
