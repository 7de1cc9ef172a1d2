#!/usr/bin/env bash
# Runs the beams with their numerical errors and writes their report into docs/beams.md; some twelve minutes on two idle cores.
# Results go to the folder given, results/beams without one; of a folder that exists only the report is written.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release -p rc-beams
program="${CARGO_TARGET_DIR:-target}/release/rc-beams"
results="${1:-results/beams}"
[ -d "$results" ] || "$program" run all --band --output "$results"
"$program" report "$results"
# The report begins with a title; pictures of single beams stay with the results.
body=$(sed -e '1s/.*/## Results/' -e '/^!\[.*\](.*\/.*)$/,+1d' -e 's/](report-/](beams\/report-/' "$results/report.md")
report="$body" awk '
    /^<!-- report -->$/ { print; print ""; print ENVIRON["report"]; print ""; skipping = 1 }
    /^<!-- end -->$/ { skipping = 0 }
    !skipping { print }
' docs/beams.md > docs/beams.new
mv docs/beams.new docs/beams.md
cp "$results"/report-*.svg "$results/report.csv" docs/beams/
for picture in slip crack; do
    cp "$results/A-SO3-3/$picture.svg" "docs/beams/A-SO3-3-$picture.svg"
done
