#!/usr/bin/env bash
# Prints the includes and names that break the layering, and fails if there are any.
#
#   check-layering.sh ROOT
#
#   RayCasting <- PhotonWalks <- FiltersIrradiance     each module may use only those left of it
#   the rooms of each module                           each may use only itself and those before it
#   RayCasting and PhotonWalks know nothing of VTK
#   CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp of RayCasting alone
#   the Python package (Modules/Python) needs VTK and Python's own library alone
#   Embree is for Testing/Benchmarks alone
#   a public header (vtk*.h) shows nothing of Eigen, CGAL, the engine or private headers
set -euo pipefail
shopt -s nullglob

root=${1:?usage: check-layering.sh ROOT}
cd "$root"

modules=(RayCasting PhotonWalks FiltersIrradiance)
# From the bottom to the top. A module's own folder, without a room, is where its front door is.
rooms=(
  RayCasting/{Simd,Progress,Geometry,Meshes,Trees,Ellipsoids,Kernels,Scene} RayCasting
  PhotonWalks/{Execution,Sampling,Surfaces,Lights,History,Photons,Tally,DirectLight,Shooting,Repair,Walks,FinalGather,Estimates,Exposure} PhotonWalks
  PhotonWalks/Views
  FiltersIrradiance/{Data,Luminaires,Input,Daylight,Pipeline,Output,Time} FiltersIrradiance)
failures=0

# reject FILE LINE_NUMBER REASON
reject()
{
  echo "$1:$2: $3"
  failures=$((failures + 1))
}

# reject_matches PATTERN REASON FILE...
reject_matches()
{
  local pattern=$1 reason=$2 file number
  shift 2
  while IFS=: read -r file number _; do
    reject "$file" "$number" "$reason"
  done < <((($# == 0)) || grep -nHE "$pattern" "$@" || true)
}

# includes FILE: line number and included path of every #include
includes()
{
  grep -nE '^[[:space:]]*#[[:space:]]*include' "$1" |
    sed -nE 's/^([0-9]+):[^"<]*["<]([^">]*)[">].*$/\1 \2/p' || true
}

# find_room FILE: sets `room` to the number of the room that a file of Modules/ lies in; empty if there is no such room
find_room()
{
  local folder=${1%/*} i
  room=
  for i in "${!rooms[@]}"; do
    [[ $folder == "${rooms[i]}" ]] && room=$i && return
  done
  true
}

# top_of MODULE: the number of its last room
top_of()
{
  local i top
  for i in "${!rooms[@]}"; do
    [[ ${rooms[i]} == "$1" || ${rooms[i]} == "$1"/* ]] && top=$i
  done
  echo "$top"
}

# One of the files of each name, relative to Modules/.
declare -A named
while read -r file; do
  named[${file##*/}]=${file#Modules/}
done < <([[ ! -d Modules ]] || find Modules -type f)

# find_included PATH FOLDER: sets `used` to the file that PATH means where a file in FOLDER includes it, relative to
# Modules/; empty if it is none of ours
find_included()
{
  local path=$1 folder=$2 module candidate
  path=${path##*../}
  [[ $path != */* && -e $folder/$path ]] && path=${folder#Modules/}/$path
  for module in "${modules[@]}"; do
    for candidate in "$module/$path" "${path#Modules/}"; do
      if [[ $candidate == "$module"/* && -e Modules/$candidate ]]; then
        used=$candidate
        return
      fi
    done
  done
  # By its name alone, in any folder.
  used=${named[${path##*/}]-}
}

source_files()
{
  local folder=$1
  [[ -d $folder ]] || return 0
  find "$folder" -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.cxx' -o -name '*.hpp' \
    -o -name '*.hxx' -o -name '*.txx' -o -name '*.inl' \) | sort
}

checked=0
for i in "${!modules[@]}"; do
  module=${modules[i]}
  for folder in "Modules/$module" "Testing/$module"; do
    mapfile -t files < <(source_files "$folder")
    checked=$((checked + ${#files[@]}))
    for file in "${files[@]}"; do
      own_room=$(top_of "$module") # a test may use all rooms of its module
      if [[ $file == Modules/* ]]; then
        find_room "${file#Modules/}"
        own_room=$room
        [[ $own_room ]] || reject "$file" 1 "this folder is no room of the list in check-layering.sh"
      fi
      while read -r number path; do
        find_included "$path" "${file%/*}"
        [[ $used && $own_room ]] || continue
        find_room "$used"
        if [[ $room ]] && ((room > own_room)); then
          reject "$file" "$number" "${rooms[own_room]} may not use ${rooms[room]} ($path)"
        fi
      done < <(includes "$file")
    done
    if [[ $module != FiltersIrradiance ]] && ((${#files[@]})); then
      reject_matches '^[[:space:]]*#[[:space:]]*include.*[vV][tT][kK]|(^|[^[:alnum:]_])(vtk|VTK_)[[:alnum:]_]*' \
        "$module may not know VTK" "${files[@]}"
    fi
  done
done
if ((checked == 0)); then
  echo "no source file found in $root: nothing was checked"
  exit 1
fi

mapfile -t files < <({ source_files Modules; source_files Examples; } | grep -vxE \
  'Modules/RayCasting/(Ellipsoids/EnclosingEllipsoid|Meshes/PolygonTriangulation)\.cpp')
reject_matches '^[[:space:]]*#[[:space:]]*include.*[<"/]CGAL/|(^|[^[:alnum:]_])CGAL::' \
  "CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp alone" "${files[@]}"

mapfile -t files < <(source_files Modules; source_files Examples; for module in "${modules[@]}"; do source_files "Testing/$module"; done)
reject_matches '^[[:space:]]*#[[:space:]]*include.*[<"/]embree' \
  "Embree is for Testing/Benchmarks alone" "${files[@]}"

reject_matches '^[[:space:]]*(from|import)[[:space:]]+(numpy|matplotlib|paraview|vtk)([[:space:].]|$)' \
  "the Python package needs vtkmodules and Python's own library alone" Modules/Python/*.py Modules/Python/*.py.in

for file in Modules/FiltersIrradiance/vtk*.h; do
  reject_matches '^[[:space:]]*#[[:space:]]*include.*[<"/](Eigen|CGAL|boost)/|(^|[^[:alnum:]_])(Eigen|CGAL)::' \
    "a public header may not show Eigen or CGAL" "$file"
  while read -r number path; do
    find_included "$path" Modules/FiltersIrradiance
    if [[ $used == RayCasting/* || $used == PhotonWalks/* ]]; then
      reject "$file" "$number" "a public header may not show the engine ($path)"
    elif [[ $used && ${used##*/} != vtk* ]]; then
      reject "$file" "$number" "a public header may not show a private one ($path)"
    fi
  done < <(includes "$file")
done

if ((failures)); then
  echo "$failures violations of the layering in $checked files"
  exit 1
fi
echo "$checked files keep the layering"
