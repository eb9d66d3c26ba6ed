#!/usr/bin/env bash
# The report of the benchmarks from made-up measurements: medians, ranges and goals come out, pictures are
# drawn, and a template that names what nobody measured is an error.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
report=$root/Testing/Benchmarks/Report
# shellcheck source=Utilities/packages.sh
source "$root/Utilities/packages.sh"
python=$(python_with matplotlib) || {
  echo "no Python with Matplotlib (Debian's python3-matplotlib)"
  exit 1
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

cat >"$scratch/results.csv" <<'END'
"Race","hare, old","speed / tortoise",3,2,4
"Race","hare, old","speed / tortoise",1,2,4
"Race","hare, old","speed / tortoise",2.5,2,4
"Race","snail","time / tortoise",9,5,2
"Field","room, 1","time, s",1,nan,nan
"Field","room, 1","error, %",0.25,nan,nan
"Field","room, 2","time, s",4,nan,nan
"Field","room, 2","time, s",6,nan,nan
"Field","hall, 2","time, s",1234.5,nan,nan
"Field","hall, 2","error, %",nan,nan,nan
"Path","hare, 1","s",1,nan,nan
"Path","hare, 1","m",2,nan,nan
"Left","over","s",1,nan,nan
END
echo "* Compiler: made up" >"$scratch/versions.md"

# write_page: the page of the template on the standard input
write_page()
{
  cat >"$scratch/page.md.in"
  "$python" "$report/page.py" "$scratch/page.md.in" "$scratch/page.md" "$scratch/versions.md" "$scratch/results.csv"
}

write_page <<'END'
{{machine}}

{{table Race}}

{{table Field}}

{{data Race}}

{{table Nobody}}

{{chart Field: height, m}}

{{lines Path: log s | m}}

In a room it takes {{value Field | room, 2 | time, s}} s; in all {{scenes Field | 2 | time, s}} s.

{{further results}}
END
while read -r line; do
  if ! grep -qxF -- "$line" "$scratch/page.md"; then
    echo "not in the page: $line"
    failures=$((failures + 1))
  fi
done <<'END'
* Compiler: made up
| hare, old | speed / tortoise | 2.5 | 1 .. 3 | >= 2 | >= 4 | bar |
| snail | time / tortoise | 9 | 9 .. 9 | <= 5 | <= 2 | no |
|  | time, s | error, % |
| room, 1 | 1 | 0.25 |
| room, 2 | 5 ±20% |  |
| hall, 2 | 1234 | - |
(Not measured in this run.)
All rows: [Race.csv](measured/Race.csv).
![height, m](pictures/Field.png)
![m over s](pictures/Path.png)
In a room it takes 5 s; in all 5 and 1234 s.
## Left
END
if ! grep -qxF '"hare, old",speed / tortoise,2.5,1 .. 3,>= 2,>= 4,bar' "$scratch/measured/Race.csv"; then
  echo "not in the data: the hare"
  failures=$((failures + 1))
fi
for picture in Field Path; do
  if ! head -c 4 "$scratch/pictures/$picture.png" | grep -qa PNG; then
    echo "no picture of $picture"
    failures=$((failures + 1))
  fi
done

for text in '{{value Race | badger | s}}' '{{value Nobody | hare | s}}' '{{lines Path: s | kg}}' '{{picture Race}}' '{{value Race}} too'; do
  if write_page <<<"$text" 2>/dev/null; then
    echo "not refused: $text"
    failures=$((failures + 1))
  fi
done

if ((failures)); then
  echo "$failures failures"
  exit 1
fi
