#!/usr/bin/env python3
"""Holds the light that `hemilux solve --points` gives out against the truth.

Usage: gathered_errors.py HEMILUX SCENE POINTS TRUTH.csv [--error X,...] [--seeds N] [-- OPTION ...]

POINTS and TRUTH.csv are made by hemilux_point_truth (bench/point_truth.cpp). A line for each run
says the true error, what the program estimated and its bound, rays and processor time.
"""
import argparse
import csv
import json
import math
import os
import resource
import subprocess
import sys
import tempfile


def true_error(table, truth):
    """The RMS error relative to the light; both halves of the truth make it free of their noise."""
    square = size = mean = mean_truth = 0.0
    for row, halves in zip(table, truth):
        for c in range(3):
            light, a, b = row[c], halves[c], halves[c + 3]
            square += (light - a) * (light - b)
            size += a * b
            mean += light
            mean_truth += .5 * (a + b)
    return math.sqrt(max(square / size, 0.0)), mean / mean_truth


def true_local_error(table, truth):
    """What 95 of 100 points are within, relative to the light there."""
    ratios = []
    for row, halves in zip(table, truth):
        pairs = [(light, halves[c], halves[c + 3]) for c, light in enumerate(row)]
        size = sum(a * b for _, a, b in pairs)
        if size > 0:
            ratios.append(sum((light - a) * (light - b) for light, a, b in pairs) / size)
    ratios.sort()
    return math.sqrt(max(ratios[int(.95 * (len(ratios) - 1))], 0.0)) if ratios else math.nan


def main():
    words = sys.argv[1:]
    options = []
    if "--" in words:
        options = words[words.index("--") + 1:]
        words = words[:words.index("--")]
    parser = argparse.ArgumentParser()
    for name in ("hemilux", "scene", "points", "truth"):
        parser.add_argument(name)
    parser.add_argument("--error", default="0.02")
    parser.add_argument("--seeds", type=int, default=3)
    given = parser.parse_args(words)
    with open(given.truth) as file:
        truth = [[float(x) for x in row] for row in csv.reader(file)]
    for error in given.error.split(","):
        for seed in range(1, given.seeds + 1):
            with tempfile.TemporaryDirectory() as folder:
                out, stats = os.path.join(folder, "a.csv"), os.path.join(folder, "a.json")
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                subprocess.run([given.hemilux, "solve", given.scene, "--points", given.points,
                                "--points-output", out, "--stats", stats, "-q", "--error", error,
                                "--seed", str(seed), *options], check=True)
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                with open(out) as file:
                    rows = [[float(row["irradiance_" + c]) for c in "rgb"]
                            for row in csv.DictReader(file)]
                with open(stats) as file:
                    found = json.load(file)
            off, mean = true_error(rows, truth)
            seconds = sum(b - a for a, b in zip(before[:2], after[:2]))
            number = lambda x: math.nan if x is None else x
            estimated = number(found["estimated_error"])
            bound = number(found.get("error_bound"))
            local = number(found.get("error_local"))
            rays = [found.get(k, 0) / 1e6
                    for k in ("rays_energy", "rays_learn", "rays_gather", "rays_division_error")]
            print(f"{os.path.basename(given.scene)} asked {100 * float(error):g} %: true "
                  f"{100 * off:.2f} %, estimated {100 * estimated:.2f} %, bound {100 * bound:.2f} %"
                  f"{' WRONG' if off > bound else ''}, mean {mean:.4f}; "
                  f"95 of 100 points: true {100 * true_local_error(rows, truth):.2f} %, "
                  f"estimated {100 * local:.2f} %; M rays "
                  + " + ".join(f"{x:.2f}" for x in rays) + f"; {seconds:.2f} s", flush=True)


main()
