#!/usr/bin/env bash
# Says which includes and names break the layering, and fails if there are any.
#
#   check-layering.sh ROOT
#
#   RayCasting <- PhotonWalks <- FiltersIrradiance     each may use only what stands left of it
#   RayCasting and PhotonWalks know nothing of VTK
#   CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp of Modules/RayCasting alone
#   Embree is for Testing/Benchmarks alone
#   a public header (vtk*.h) shows nothing of Eigen, CGAL, the engine or private headers
set -euo pipefail
shopt -s nullglob

root=${1:?usage: check-layering.sh ROOT}
cd "$root"

layers=(RayCasting PhotonWalks FiltersIrradiance)
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
  for file in "$@"; do
    while IFS=: read -r number _; do
      reject "$file" "$number" "$reason"
    done < <(grep -nE "$pattern" "$file" || true)
  done
}

# includes FILE: line number and included path of every #include
includes()
{
  grep -nE '^[[:space:]]*#[[:space:]]*include' "$1" |
    sed -nE 's/^([0-9]+):[^"<]*["<]([^">]*)[">].*$/\1 \2/p' || true
}

# layer_of PATH FOLDER: the number of the layer that PATH, included by a file in FOLDER, lies in;
# nothing if it is none of ours
layer_of()
{
  local path=$1 folder=$2 i
  for i in "${!layers[@]}"; do
    if [[ $path == "${layers[i]}"/* || $path == */"${layers[i]}"/* ]]; then
      echo "$i"
      return
    fi
  done
  [[ -e $folder/${path##*/} ]] && return # its own
  for i in "${!layers[@]}"; do
    if [[ -e Modules/${layers[i]}/${path##*/} ]]; then
      echo "$i"
      return
    fi
  done
}

source_files()
{
  local folder=$1
  [[ -d $folder ]] || return 0
  find "$folder" -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.cxx' -o -name '*.hpp' \
    -o -name '*.hxx' -o -name '*.txx' -o -name '*.inl' \) | sort
}

checked=0
for i in "${!layers[@]}"; do
  for folder in "Modules/${layers[i]}" "Testing/${layers[i]}"; do
    mapfile -t files < <(source_files "$folder")
    checked=$((checked + ${#files[@]}))
    for file in "${files[@]}"; do
      while read -r number path; do
        layer=$(layer_of "$path" "$(dirname "$file")")
        if [[ -n $layer ]] && ((layer > i)); then
          reject "$file" "$number" "${layers[i]} may not use ${layers[layer]} ($path)"
        fi
      done < <(includes "$file")
    done
    if ((i < 2)) && ((${#files[@]})); then
      reject_matches '^[[:space:]]*#[[:space:]]*include.*[vV][tT][kK]|(^|[^[:alnum:]_])(vtk|VTK_)[[:alnum:]_]*' \
        "${layers[i]} may not know VTK" "${files[@]}"
    fi
  done
done
if ((checked == 0)); then
  echo "no source file found in $root: nothing was checked"
  exit 1
fi

mapfile -t files < <(source_files Modules; source_files Examples)
for file in "${files[@]}"; do
  [[ $file == Modules/RayCasting/EnclosingEllipsoid.cpp ||
    $file == Modules/RayCasting/PolygonTriangulation.cpp ]] && continue
  reject_matches '^[[:space:]]*#[[:space:]]*include.*[<"/]CGAL/|(^|[^[:alnum:]_])CGAL::' \
    "CGAL is for EnclosingEllipsoid.cpp and PolygonTriangulation.cpp alone" "$file"
done

mapfile -t files < <(source_files Modules; source_files Examples; for layer in "${layers[@]}"; do source_files "Testing/$layer"; done)
for file in "${files[@]}"; do
  reject_matches '^[[:space:]]*#[[:space:]]*include.*[<"/]embree' \
    "Embree is for Testing/Benchmarks alone" "$file"
done

for file in Modules/FiltersIrradiance/vtk*.h; do
  reject_matches '^[[:space:]]*#[[:space:]]*include.*[<"/](Eigen|CGAL|boost)/|(^|[^[:alnum:]_])(Eigen|CGAL)::' \
    "a public header may not show Eigen or CGAL" "$file"
  while read -r number path; do
    name=${path##*/}
    if [[ -e Modules/RayCasting/$name || -e Modules/PhotonWalks/$name ||
      $path == *RayCasting/* || $path == *PhotonWalks/* ]]; then
      reject "$file" "$number" "a public header may not show the engine ($path)"
    elif [[ $name != vtk* && -e Modules/FiltersIrradiance/$name ]]; then
      reject "$file" "$number" "a public header may not show a private one ($path)"
    fi
  done < <(includes "$file")
done

if ((failures)); then
  echo "$failures violations of the layering in $checked files"
  exit 1
fi
echo "$checked files keep the layering"
