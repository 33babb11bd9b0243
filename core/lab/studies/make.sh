#!/usr/bin/env bash
# Measures everything that core/lab/README.md shows and puts the pictures beside this script. Takes about ten minutes
# on a quiet machine. The first argument is the folder of the programs, default build/bin.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
lab=$(cd "${1:-$here/../../../build/bin}" && pwd)/flexcast-lab
cd "$here/../../../server/scenes"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# trade NAME SCENE OPTION...
trade() {
  local name=$1
  shift
  echo "== trade $*"
  "$lab" trade "$@" -o "$work/$name" 2>/dev/null | tee "$here/$name.txt"
  cp "$work/$name/trade.svg" "$here/$name.svg"
  cp "$work/$name/order.svg" "$here/$name-order.svg"
}

limits() {
  local name=$1
  shift
  echo "== limits $*"
  "$lab" limits "$@" -o "$work/$name" 2>/dev/null | tee "$here/$name.txt"
  cp "$work/$name/limits.svg" "$here/$name.svg"
}

# Six scenes.
trade pendulum pendulum.toml --until 2 --budget 30
trade rope rope.toml --until 1 --budget 45
trade cloth cloth.toml --until 0.5 --budget 45
trade cantilever cantilever.toml --until 1 --budget 60
trade twist twist.toml --until 2 --budget 60
trade drop drop.toml --until 1 --budget 45

# Elements against steps: the bending beam.
trade sag sag.toml --until 0.5 --budget 60 --elements tet4,tet10 --integrators velocity_verlet,implicit_midpoint \
  --set 'beam.mesh.cells=[8,1,1]' --refine 0,1

# Stability of all explicit schemes.
limits limits-cantilever cantilever.toml --budget 60 --vary stiffness,poisson,quality,mass_ratio

# One bob on one spring that hangs down.
bob=(rope.toml --set 'rope.mesh.cells=[1]' --set 'rope.rotation=[0,1.5707963267948966,0]' --set rope.mass=0.1
  --set end.node=1 --set rope.stiffness=40 --set rope.drag=0 --set rope.damping.mass=0 --set time.integrator=rk4
  --set time.substeps=10)
"$lab" run "${bob[@]}" --until 0.6 --set rope.damping=2 --csv "$work/both.csv" >/dev/null
"$lab" run "${bob[@]}" --until 0.6 --set rope.damping=0 --csv "$work/elastic.csv" >/dev/null
"$lab" run "${bob[@]}" --until 0.6 --set rope.damping=2 --set rope.stiffness=0 --csv "$work/damping.csv" >/dev/null
"$lab" plot "$work/both.csv" "$work/elastic.csv" "$work/damping.csv" -o "$here/spring-terms.svg" --y end.z \
  --labels 'both terms,k_s alone,k_d alone' --title 'A bob on one spring: height of the bob'
for damping in 0.05 0.5 4 40; do
  "$lab" run "${bob[@]}" --until 2 --set rope.damping=$damping --csv "$work/kd$damping.csv" >/dev/null
done
"$lab" plot "$work"/kd0.05.csv "$work"/kd0.5.csv "$work"/kd4.csv "$work"/kd40.csv -o "$here/spring-damping.svg" --y end.z \
  --labels 'k_d = 0.05,k_d = 0.5,k_d = 4 (critical),k_d = 40 N.s' --title 'The same bob with more and more damping'

# What stiffness costs, and what damping does to the largest step.
limits limits-rope rope.toml --budget 40 --vary stiffness,damping
for factor in 1 100 10000; do
  trade rope-stiffness-$factor rope.toml --until 0.3 --budget 30 --set rope.stiffness=$((400 * factor)) \
    --integrators symplectic_euler,velocity_verlet,backward_euler,implicit_midpoint,xpbd,vbd
done
