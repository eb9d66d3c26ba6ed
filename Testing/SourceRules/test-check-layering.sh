#!/usr/bin/env bash
# The negative control of check-layering.sh: in a made-up tree it must find each kind of violation, for the
# right reason and in the right file, and the tree without violations must pass.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree()
{
  rm -rf "${tree:?}"/*
  mkdir -p "$tree"/Modules/{RayCasting/{Geometry,Meshes,Ellipsoids},PhotonWalks/{Surfaces,Tally},FiltersIrradiance/{Input,Output},Python} \
    "$tree"/Testing/{RayCasting,PhotonWalks}
  cd "$tree"
  printf '#include <Eigen/Core>\n' >Modules/RayCasting/Geometry/Vector.h
  printf '#include "Geometry/Vector.h"\n' >Modules/RayCasting/Ellipsoids/EnclosingEllipsoid.h
  printf '#include "Ellipsoids/EnclosingEllipsoid.h"\n#include <CGAL/Cartesian.h>\n' >Modules/RayCasting/Ellipsoids/EnclosingEllipsoid.cpp
  printf '#include <CGAL/Cartesian.h>\nusing Kernel = CGAL::Cartesian<double>;\n' >Modules/RayCasting/Meshes/PolygonTriangulation.cpp
  printf '#include "RayCasting/Geometry/Vector.h"\n// as VTK would do\n' >Modules/PhotonWalks/Surfaces/Emitter.h
  printf '#include "Surfaces/Emitter.h"\n' >Modules/PhotonWalks/Surfaces/Emitter.cpp
  printf '#include "Surfaces/Emitter.h"\n' >Modules/PhotonWalks/Tally/CellSums.h
  printf '#include "Tally/CellSums.h"\n' >Modules/PhotonWalks/Engine.h
  printf '#include "PhotonWalks/Surfaces/Emitter.h"\n' >Modules/FiltersIrradiance/Input/Converter.h
  printf '#include "Input/Converter.h"\n' >Modules/FiltersIrradiance/Output/Writer.h
  printf '#include "vtkObject.h"\n#include <memory>\nclass vtkX;\n' >Modules/FiltersIrradiance/vtkX.h
  printf '#include "vtkX.h"\n#include "Input/Converter.h"\n' >Modules/FiltersIrradiance/vtkX.cxx
  printf 'import re\nfrom vtkmodules.vtkCommonCore import vtkObject\n' >Modules/Python/pipeline.py
  printf '#include "RayCasting/Geometry/Vector.h"\n#include <CGAL/Gmpq.h>\n' >Testing/RayCasting/TestVector.cpp
}

# expect_violation FILE LINE REASON: FILE with LINE added must be refused for REASON
expect_violation()
{
  local file=$1 line=$2 reason=$3 report
  clean_tree
  mkdir -p "$(dirname "$tree/$file")"
  printf '%s\n' "$line" >>"$tree/$file"
  if report=$(bash "$here/check-layering.sh" "$tree"); then
    echo "not found: '$line' in $file"
    failures=$((failures + 1))
  elif ! grep -F "$file:" <<<"$report" | grep -qF "$reason"; then
    printf '%s\n' "found for another reason: '$line' in $file" "$report"
    failures=$((failures + 1))
  fi
}

clean_tree
if ! bash "$here/check-layering.sh" "$tree"; then
  echo "the tree without a violation was refused"
  failures=$((failures + 1))
fi

expect_violation Modules/RayCasting/Geometry/Vector.h '#include "PhotonWalks/Surfaces/Emitter.h"' "RayCasting/Geometry may not use PhotonWalks/Surfaces"
expect_violation Modules/RayCasting/Geometry/Vector.h '#include "../../PhotonWalks/Surfaces/Emitter.h"' "RayCasting/Geometry may not use PhotonWalks/Surfaces"
expect_violation Modules/RayCasting/Geometry/Vector.h '#include <Emitter.h>' "RayCasting/Geometry may not use PhotonWalks/Surfaces"
expect_violation Modules/RayCasting/Geometry/Vector.h '#  include "Converter.h"' "RayCasting/Geometry may not use FiltersIrradiance/Input"
expect_violation Modules/PhotonWalks/Surfaces/Emitter.cpp '#include "FiltersIrradiance/Input/Converter.h"' "PhotonWalks/Surfaces may not use FiltersIrradiance/Input"
expect_violation Testing/RayCasting/TestVector.cpp '#include "PhotonWalks/Surfaces/Emitter.h"' "RayCasting may not use PhotonWalks/Surfaces"
expect_violation Modules/RayCasting/Geometry/Vector.h '#include "Ellipsoids/EnclosingEllipsoid.h"' "RayCasting/Geometry may not use RayCasting/Ellipsoids"
expect_violation Modules/PhotonWalks/Surfaces/Emitter.h '#include "Tally/CellSums.h"' "PhotonWalks/Surfaces may not use PhotonWalks/Tally"
expect_violation Modules/PhotonWalks/Surfaces/Emitter.h '#include "../Tally/CellSums.h"' "PhotonWalks/Surfaces may not use PhotonWalks/Tally"
expect_violation Modules/PhotonWalks/Tally/CellSums.h '#include "Engine.h"' "PhotonWalks/Tally may not use PhotonWalks"
expect_violation Modules/FiltersIrradiance/Input/Converter.h '#include "Output/Writer.h"' "FiltersIrradiance/Input may not use FiltersIrradiance/Output"
expect_violation Modules/FiltersIrradiance/Output/Writer.h '#include "vtkX.h"' "FiltersIrradiance/Output may not use FiltersIrradiance"
expect_violation Modules/PhotonWalks/Attic/Old.h '#include "Surfaces/Emitter.h"' "this folder is no room"
expect_violation Modules/RayCasting/Geometry/Vector.h '#include <vtkPolyData.h>' "RayCasting may not know VTK"
expect_violation Modules/PhotonWalks/Surfaces/Emitter.h '#include "sub/vtkPolyData.h"' "PhotonWalks may not know VTK"
expect_violation Modules/PhotonWalks/Surfaces/Emitter.h 'class vtkPolyData;' "PhotonWalks may not know VTK"
expect_violation Modules/PhotonWalks/Surfaces/Emitter.h 'int count(const vtkIdType* ids);' "PhotonWalks may not know VTK"
expect_violation Testing/PhotonWalks/TestEmitter.cpp '#include <vtkNew.h>' "PhotonWalks may not know VTK"
expect_violation Modules/RayCasting/Geometry/Vector.h '#include <CGAL/Cartesian.h>' "CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp alone"
expect_violation Modules/RayCasting/Ellipsoids/EnclosingEllipsoid.h '#include <CGAL/Cartesian.h>' "CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp alone"
expect_violation Modules/RayCasting/Meshes/PolygonTriangulation.h '#include <CGAL/Cartesian.h>' "CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp alone"
expect_violation Modules/FiltersIrradiance/PolygonTriangulation.cpp 'CGAL::Bbox_3 box;' "CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp alone"
expect_violation Modules/FiltersIrradiance/vtkX.cxx 'CGAL::Bbox_3 box;' "CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp alone"
expect_violation Modules/RayCasting/Geometry/Vector.h '#include <embree3/rtcore.h>' "Embree is for Testing/Benchmarks alone"
expect_violation Modules/FiltersIrradiance/vtkX.h '#include <Eigen/Core>' "a public header may not show Eigen or CGAL"
expect_violation Modules/FiltersIrradiance/vtkX.h '#include <CGAL/Cartesian.h>' "a public header may not show Eigen or CGAL"
expect_violation Modules/FiltersIrradiance/vtkX.h '#include "RayCasting/Geometry/Vector.h"' "a public header may not show the engine"
expect_violation Modules/FiltersIrradiance/vtkX.h '#include "Emitter.h"' "a public header may not show the engine"
expect_violation Modules/FiltersIrradiance/vtkX.h '#include "Converter.h"' "a public header may not show a private one"
expect_violation Modules/Python/pipeline.py 'import numpy as np' "vtkmodules and Python's own library alone"
expect_violation Modules/Python/pipeline.py '    from paraview.simple import *' "vtkmodules and Python's own library alone"
expect_violation Modules/Python/__init__.py.in 'import vtk' "vtkmodules and Python's own library alone"

rm -rf "${tree:?}"/*
if bash "$here/check-layering.sh" "$tree" >/dev/null; then
  echo "an empty tree was let pass"
  failures=$((failures + 1))
fi

if ((failures)); then
  echo "$failures controls failed"
  exit 1
fi
echo "every kind of violation is found"
