#!/bin/sh
# Makes bunny.node and bunny.ele beside this script; the same bytes every time.
#
#   make_bunny.sh [FOLDER]
#
# Needs node, tetgen 1.5.0 (Debian: nodejs, tetgen) and the npm package bunny 1.0.1, which is taken from
# FOLDER/node_modules if a folder is given, else downloaded with npm into a temporary folder.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [ $# -ge 1 ]; then
  modules=$(cd "$1/node_modules" && pwd)
else
  npm install --silent --no-audit --no-fund --prefix "$work" bunny@1.0.1
  modules=$work/node_modules
fi

# The surface: y up becomes z up, the feet stand on z = 0, 0.1545 m tall, coordinates to the micrometre.
cat > "$work/surface.js" << 'SURFACE'
const { positions, cells } = require(process.argv[2] + '/bunny');
const scale = 0.016;
const floor = Math.min(...positions.map((p) => p[1]));
const text = (metres) => metres.toFixed(6);
console.log(`${positions.length} 3 0 0`);
positions.forEach(([x, y, z], i) =>
  console.log(`${i} ${text(scale * x)} ${text(-scale * z)} ${text(scale * (y - floor))}`));
console.log(`${cells.length} 0`);
cells.forEach((cell) => console.log(`1\n3 ${cell.join(' ')}`));
console.log('0\n0');
SURFACE
node "$work/surface.js" "$modules" > "$work/bunny.poly"

# Y keeps the surface; q: radius to edge at most 1.6, dihedral angles from 12 degrees where the surface allows it;
# O and o: flips and smoothing against angles above 130 degrees.
(cd "$work" && tetgen -pYq1.6/12O9/7o/130 bunny.poly > tetgen.log)

# Coordinates to the micrometre again, single spaces, one line on the origin.
cat > "$work/shorten.js" << 'SHORTEN'
const lines = require('fs').readFileSync(process.argv[2], 'utf8').split('\n').filter((l) => l && !l.startsWith('#'));
const rounded = (word) => (word.includes('.') || word.includes('e') ? String(Number(Number(word).toFixed(6))) : word);
console.log('# Stanford bunny (Stanford 3D Scanning Repository), metres, z up; see README.md');
lines.forEach((line) => console.log(line.trim().split(/\s+/).map(rounded).join(' ')));
SHORTEN
node "$work/shorten.js" "$work/bunny.1.node" > "$here/bunny.node"
node "$work/shorten.js" "$work/bunny.1.ele" > "$here/bunny.ele"
