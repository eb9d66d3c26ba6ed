# shellcheck shell=bash
# For bash to source. The only list of what must be installed, by role, and the way to get it:
#
#   require_packages ROLE...      build, display, python, test, fuzz, package, benchmark, meshes (to fetch the benchmark's)
#   packages_of paraview          what Testing/ParaView/fetch-paraview.sh unpacks; it cannot be installed beside VTK
#   missing_libraries_of PACKAGE  Debian's packages of the libraries that PACKAGE needs and that are not installed
#   fetch_data                    what Data/fetch.sh fetches
#
# On Debian and its derivatives, missing packages are installed, as root or through sudo; nothing is printed if
# none is missing. Elsewhere, or without root, it prints what is missing and ends the script with status 2.

has_dpkg=no
if command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
  has_dpkg=yes
fi

packages_of()
{
  case $1 in
    build) echo g++ cmake ninja-build libvtk9-dev libcgal-dev libeigen3-dev ;;
    display) echo xvfb ;;
    python) echo python3-numpy ;; # for examples; VTK's own modules come with libvtk9-dev
    test) echo libgtest-dev clang-format clang-tidy python3-matplotlib python3-numpy doxygen ;;
    package) echo dpkg-dev file ;;
    fuzz) echo clang libclang-rt-dev ;;
    benchmark) echo libembree-dev python3-matplotlib ;;
    meshes) echo npm ;;
    paraview) echo paraview paraview-dev python3-paraview ;; # unpacked only
    *)
      echo "packages.sh: unknown role $1" >&2
      exit 2
      ;;
  esac
}

# Describes a Debian package for users of other systems.
description_of()
{
  case $1 in
    g++) echo "a C++17 compiler" ;;
    cmake) echo "CMake 3.21 or newer" ;;
    ninja-build) echo "Ninja" ;;
    libvtk9-dev) echo "VTK 9.1 or newer, with its headers" ;;
    libcgal-dev) echo "CGAL 5 or 6, with its headers" ;;
    libeigen3-dev) echo "Eigen 3.3 or newer" ;;
    xvfb) echo "Xvfb, and Mesa's software OpenGL" ;;
    libgtest-dev) echo "GoogleTest" ;;
    libclang-rt-dev) echo "clang's libFuzzer" ;;
    libembree-dev) echo "Embree 3" ;;
    python3-matplotlib) echo "Python 3 with Matplotlib" ;;
    dpkg-dev) echo "dpkg-shlibdeps" ;;
    python3-numpy) echo "Python 3 with NumPy" ;;
    *) echo "$1" ;;
  esac
}

# has_config NAME...: whether a CMake package has its file at one of the usual places
has_config()
{
  local places=(/usr /usr/local /opt/local /opt/homebrew "${CONDA_PREFIX:-/usr}")
  local name found additional
  IFS=':;' read -r -a additional <<<"${CMAKE_PREFIX_PATH:-}"
  for name in "$@"; do
    found=$(find -L "${places[@]}" "${additional[@]}" -maxdepth 6 -path '*cmake*' -name "$name" \
      -print -quit 2>/dev/null) || true
    [[ -z $found ]] || return 0
  done
  return 1
}

has_command()
{
  local name
  for name in "$@"; do
    ! command -v "$name" >/dev/null || return 0
  done
  return 1
}

can_fuzz()
{
  has_command clang++ &&
    echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, long) { return 0; }' |
    clang++ -fsanitize=fuzzer -x c++ -o /dev/null - 2>/dev/null
}

# python_with MODULE: the Python that has it: Debian's own, where another one comes first
python_with()
{
  local python
  for python in python3 /usr/bin/python3; do
    if has_command "$python" && "$python" -c "import $1" 2>/dev/null; then
      echo "$python"
      return 0
    fi
  done
  return 1
}

is_present_without_dpkg()
{
  case $1 in
    g++) has_command "${CXX:-c++}" g++ clang++ ;;
    ninja-build) has_command ninja ninja-build ;;
    libvtk9-dev) [[ -n ${VTK_DIR:-} ]] || has_config vtk-config.cmake VTKConfig.cmake ;;
    libcgal-dev) [[ -n ${CGAL_DIR:-} ]] || has_config CGALConfig.cmake ;;
    libeigen3-dev) [[ -n ${Eigen3_DIR:-} ]] || has_config Eigen3Config.cmake ;;
    xvfb) has_command Xvfb ;;
    libgtest-dev) [[ -n ${GTest_DIR:-} ]] || has_config GTestConfig.cmake ;;
    libclang-rt-dev) can_fuzz ;;
    libembree-dev) [[ -n ${embree_DIR:-} ]] || has_config 'embree-config.cmake' ;;
    python3-matplotlib) python_with matplotlib >/dev/null ;;
    dpkg-dev) has_command dpkg-shlibdeps ;;
    python3-numpy) python_with numpy >/dev/null ;;
    *) has_command "$1" "$1-14" ;;
  esac
}

is_installed()
{
  if [[ $has_dpkg == yes ]]; then
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
  else
    is_present_without_dpkg "$1"
  fi
}

missing_packages()
{
  local package
  for package in "$@"; do
    is_installed "$package" || echo "$package"
  done
}

# As apt would install it: Qt, for one, has other names in each Debian.
missing_libraries_of()
{
  LC_ALL=C apt-get -s install --no-install-recommends "$1" | awk '$1 == "Inst" && $2 ~ /^lib/ && $3 !~ /^\[/ { print $2 }'
}

# has_candidates PACKAGE...: whether this system's package lists have them all
has_candidates()
{
  local package
  for package in "$@"; do
    grep -q 'Candidate: [^(]' <<<"$(LC_ALL=C apt-cache policy "$package")" || return 1
  done
}

# apt ARGUMENT...: apt-get as root, without questions
apt()
{
  local as_root=(env DEBIAN_FRONTEND=noninteractive)
  ((EUID == 0)) || as_root=(sudo "${as_root[@]}")
  "${as_root[@]}" apt-get -q -o DPkg::Lock::Timeout=600 "$@"
}

can_install()
{
  [[ $has_dpkg == yes ]] && { ((EUID == 0)) || has_command sudo; }
}

require_packages()
{
  local role wanted=() additional missing log
  for role in "$@"; do
    read -r -a additional <<<"$(packages_of "$role")"
    wanted+=("${additional[@]}")
  done

  mapfile -t missing < <(missing_packages "${wanted[@]}")
  ((${#missing[@]})) || return 0

  if [[ $has_dpkg == no ]]; then
    echo "To be installed first, by this system's own means:"
    for package in "${missing[@]}"; do
      echo "  $(description_of "$package") (Debian's $package)"
    done
    exit 2
  fi
  if ! can_install; then
    echo "To be installed first, by root: apt-get install --no-install-recommends ${missing[*]}"
    exit 2
  fi

  echo "Installing ${missing[*]} and what they need (on a bare system some minutes) ..."
  log=$(mktemp)
  if ! { apt update && apt install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 40 "$log"
    echo "Could not install ${missing[*]}; apt-get's whole report: $log"
    exit 2
  fi
  rm -f "$log"
}

# Run in the folder of the repository. A download needs apt's package lists, and a system that has everything
# installed may still have none.
fetch_data()
{
  local report
  if report=$(Data/fetch.sh 2>&1); then
    return 0
  fi
  if can_install && apt update >/dev/null 2>&1 && report=$(Data/fetch.sh 2>&1); then
    return 0
  fi
  echo "$report"
  return 1
}
