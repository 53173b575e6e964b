"""Shows how the error of the paper's method falls with its rays, beside plain Monte Carlo radiosity.

Prints the true errors against a reference by full matrix, and fails where they do not fall.
"""

# %% The Cornell box, and a reference that is good enough for errors of some per cent.
import pathlib

import hemilux

box = hemilux.read(pathlib.Path(__file__).parents[2] / "examples/scenes/cornell_box.obj")
reference = hemilux.solve(box, "matrix", error=0.01)

# %% Each step of a method is a complete solution; their mean is the result.
for method in ("hemisphere", "progressive-monte-carlo"):
    steps = hemilux.solve(box, method, steps=64, reference=reference).steps
    for k in (0, 3, 15, 63):
        print(f"{method:24} {steps['rays'][k]:9} rays: {steps['true_error'][k]:6.2%}, "
              f"estimated {steps['estimated_error'][k]:6.2%}")
    assert steps["true_error"][63] < steps["true_error"][3] / 2
