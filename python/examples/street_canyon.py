"""Shows the sky view factors of a street canyon, across the street and up its walls.

Prints them beside their closed forms, and fails where they differ.
"""

# %% A street of 10 m between walls of 15 m. Strips of 1 m run along 10 km of it.
import numpy as np

import hemilux

width, height, length, strips = 10.0, 15.0, 10_000.0, 10


def strip(a, b):
    """The four corners of a strip between two points of the cross-section."""
    (x0, z0), (x1, z1) = a, b
    return [[x0, 0, z0], [x1, 0, z1], [x1, length, z1], [x0, length, z0]]


x, z = np.linspace(0, width, strips + 1), np.linspace(0, height, strips + 1)
street = [strip((x[i], 0), (x[i + 1], 0)) for i in range(strips)]
west = [strip((0, z[i + 1]), (0, z[i])) for i in range(strips)]
east = [strip((width, z[i]), (width, z[i + 1])) for i in range(strips)]
vertices = np.concatenate(street + west + east)
surface = np.repeat(["street", "west", "east"], strips)
mesh = hemilux.Mesh(vertices, np.arange(len(vertices)).reshape(-1, 4), surface)

# %% Nothing stands in the street, so the factors between strips are exact. The rest of a row is sky,
# or a little ground past the ends of the street; rays say how much of each.
factors = hemilux.view_factors(mesh)
sky = factors.sky.reshape(3, strips)
error = factors.sky_standard_error.reshape(3, strips)

# %% In an endless street a point sees the sky between two angles. A strip has the mean of its points.
def mean(distance):
    """Mean of d / sqrt(d^2 + h^2) over each strip, with d the distance from a wall."""
    return np.diff(np.hypot(distance, height)) / np.diff(distance)


on_street = (mean(x) + mean(x)[::-1]) / 2
above = height - z
on_wall = (1 - np.diff(np.hypot(width, above)) / np.diff(above)) / 2

print("street, from the west: sky view factor, standard error, closed form")
for i in range(strips):
    print(f"{x[i]:5.1f} to {x[i + 1]:4.1f} m  {sky[0, i]:.4f} +- {error[0, i]:.4f}  {on_street[i]:.4f}")
print("west wall, from below:")
for i in range(strips):
    print(f"{z[i]:5.1f} to {z[i + 1]:4.1f} m  {sky[1, i]:.4f} +- {error[1, i]:.4f}  {on_wall[i]:.4f}")

# %% The whole street, and the whole walls.
whole = factors.by(surface)
ratio = height / width
print("whole street:", f"{whole.sky[0]:.4f},", f"closed form {np.hypot(1, ratio) - ratio:.4f}")

largest = max(abs(sky[0] - on_street).max(), abs(sky[1] - on_wall).max())
print(f"largest difference {largest:.1e}, by the street's ends and the errors of single strips")
assert largest < 2e-3
assert abs(whole.sky[0] - (np.hypot(1, ratio) - ratio)) < 2e-3
