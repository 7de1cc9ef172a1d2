#!/usr/bin/env bash
# Runs the beams with their numerical errors, those with sheets with perfect bond too, and writes their report into docs/beams.md;
# some twenty minutes on two cores.
# Results go to the folder given, without one to where accuracy.sh has the same runs; of a folder that exists only the report is written.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release -p rc-beams -p fe-tests --bins
target="${CARGO_TARGET_DIR:-target}/release"
results="${1:-results/accuracy/default}"
[ -d "$results" ] || "$target/rc-beams" run all --band --counterfactual --output "$results"
"$target/rc-beams" report "$results"
# The report begins with a title; pictures of single beams stay with the results.
sed -e '1s/.*/## Results/' -e '/^!\[.*\](.*\/.*)$/,+1d' -e 's/](report-/](beams\/report-/' "$results/report.md" |
    "$target/insert" docs/beams.md report
cp "$results"/report-*.svg "$results/report.csv" docs/beams/
for picture in slip crack; do
    cp "$results/A-SO3-3/$picture.svg" "docs/beams/A-SO3-3-$picture.svg"
done
cp "$results/A-SO3-1/curve.svg" docs/A-SO3-1.svg
