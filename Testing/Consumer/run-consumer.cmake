# Installs a build tree, looks at what was installed, and builds and runs Examples/LitRoom against it.
#
#   python   imports the installed package vtkIrradiance, below `python_dir`; "none" for none
#   build    the build tree; without it a static one is made from `source`
#   engine   the build tree whose engine that one takes
#   scratch  a folder for all that is made here

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if (NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif ()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(toolchain
  -G "${generator}"
  "-DCMAKE_MAKE_PROGRAM=${make_program}"
  "-DCMAKE_C_COMPILER=${c_compiler}"
  "-DCMAKE_CXX_COMPILER=${cxx_compiler}"
  "-DVTK_DIR=${vtk_dir}")
set(prefix "${scratch}/prefix")
file(REMOVE_RECURSE "${scratch}/prefix" "${scratch}/package" "${scratch}/consumer")

if (NOT build)
  # Kept from run to run: what did not change is not built again.
  set(build "${scratch}/build")
  run("${CMAKE_COMMAND}" -S "${source}" -B "${build}" ${toolchain}
    -DBUILD_TESTING=OFF -DBUILD_SHARED_LIBS=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELEASE=-O0
    "-DCMAKE_INSTALL_PREFIX=${prefix}"
    "-DVTKIRRADIANCE_ENGINE_DIR=${engine}")
  run("${CMAKE_COMMAND}" --build "${build}" --parallel)
endif ()
run("${CMAKE_COMMAND}" --install "${build}" --prefix "${prefix}")

# The package: one target, and no word of the engine or of what the engine is made with.
file(GLOB_RECURSE package "${prefix}/*/cmake/vtkIrradiance/*.cmake")
file(GLOB_RECURSE headers "${prefix}/include/vtkIrradiance/*.h")
if (NOT package OR NOT headers)
  message(FATAL_ERROR "no package or no header in ${prefix}")
endif ()
foreach (file IN LISTS package headers)
  file(STRINGS "${file}" lines REGEX "CGAL|[Ee]igen|gmp|mpfr|RayCasting|(^|[^k])PhotonWalks")
  if (file MATCHES "\\.h$")
    list(FILTER lines INCLUDE REGEX "#[ ]*include")
  endif ()
  if (lines)
    message(FATAL_ERROR "${file} shows what is private:\n${lines}")
  endif ()
  # Whatever the source folder is called: its name alone may well stand in the package.
  file(READ "${file}" text)
  foreach (folder IN ITEMS "${source}/Modules" "${source}/CMake" "${build}")
    string(FIND "${text}" "${folder}" found)
    if (NOT found EQUAL -1)
      message(FATAL_ERROR "${file} points back to ${folder}")
    endif ()
  endforeach ()
endforeach ()

# Python finds its module, and that finds the library, from where they are installed.
if (python AND NOT python STREQUAL "none")
  run("${CMAKE_COMMAND}" -E env --unset=LD_LIBRARY_PATH "PYTHONPATH=${prefix}/${python_dir}"
    "${python}" -c "print(__import__('vtkIrradiance').__file__)"
    WORKING_DIRECTORY "${scratch}")
  string(FIND "${output}" "${prefix}/" found)
  if (NOT found EQUAL 0)
    message(FATAL_ERROR "Python imports not what was installed, but ${output}")
  endif ()
  execute_process(COMMAND readelf -d "${prefix}/${python_dir}/vtkIrradiance/vtkFiltersIrradiance.so"
    OUTPUT_VARIABLE dynamic)
  string(FIND "${dynamic}" "${build}" found)
  if (NOT found EQUAL -1)
    message(FATAL_ERROR "the installed module points back to ${build}:\n${dynamic}")
  endif ()
endif ()

set(installed ${toolchain} "-DCMAKE_PREFIX_PATH=${prefix}")
run("${CMAKE_COMMAND}" -S "${source}/Testing/Consumer/Package" -B "${scratch}/package" ${installed})
run("${CMAKE_COMMAND}" -S "${source}/Examples/LitRoom" -B "${scratch}/consumer" ${installed})
run("${CMAKE_COMMAND}" --build "${scratch}/consumer")
run("${scratch}/consumer/LitRoom" WORKING_DIRECTORY "${scratch}/consumer")
message(STATUS "${output}")
if (NOT output MATCHES "Irradiance ([0-9.e+-]+) to ([0-9.e+-]+) W/m2")
  message(FATAL_ERROR "the consumer said:\n${output}")
endif ()
# The lamp lights the room, and nowhere is more than ten times what the lamp itself gives.
if (NOT CMAKE_MATCH_2 GREATER 0 OR CMAKE_MATCH_2 GREATER 1000)
  message(FATAL_ERROR "${CMAKE_MATCH_2} W/m2 cannot be")
endif ()
foreach (file IN ITEMS irradiance.vtm irradiance/irradiance_0.vtp irradiance.png ParaViewState.py)
  if (NOT EXISTS "${scratch}/consumer/LitRoom-output/${file}")
    message(FATAL_ERROR "the consumer wrote no ${file}")
  endif ()
endforeach ()
