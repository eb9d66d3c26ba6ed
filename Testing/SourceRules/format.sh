#!/usr/bin/env bash
# Formats our C++ sources with .clang-format, or reports those that are not formatted.
#
#   format.sh --check|--in-place [CLANG_FORMAT]
#
# The status is 77 for another version of clang-format than that of the rules: it would format differently.
set -euo pipefail

mode=${1:?usage: format.sh --check|--in-place [CLANG_FORMAT]}
clang_format=${2:-clang-format}
if ! command -v "$clang_format" >/dev/null; then
  echo "format.sh: no $clang_format"
  exit 1
fi
version=$("$clang_format" --version | sed -nE 's/.* version ([0-9]+)\..*/\1/p')
if [[ $version != 14 ]]; then
  echo "Skipped: Format has the rules of clang-format 14, and there is only version $version"
  exit 77
fi
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

case $mode in
  --check) arguments=(--dry-run -Werror) ;;
  --in-place) arguments=(-i) ;;
  *)
    echo "format.sh: unknown mode $mode"
    exit 1
    ;;
esac

mapfile -t files < <(find Modules Testing Examples -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.cxx' -o -name '*.inl' \) | sort)
if ((${#files[@]} == 0)); then
  echo "format.sh: no source file found"
  exit 1
fi
"$clang_format" "${arguments[@]}" "${files[@]}"
echo "${#files[@]} files"
