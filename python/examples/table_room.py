"""Light a room from a glTF file: at two points on its table and in a picture, each with its error."""

import os

import hemilux

SCENE = os.path.join(os.path.dirname(__file__), "../../examples/scenes/table_room.glb")

room = hemilux.read(SCENE, max_edge=0.5)
light = hemilux.solve(room, error=0.02)
table = light.points([[1.6, 0.75, 1.3, 0, 1, 0], [2, 0.75, 1.5, 0, 1, 0]])
picture = light.picture(size=(320, 240))
for irradiance, error in zip(table.irradiance[:, 0], table.standard_error[:, 0]):
    print(f"{irradiance:.1f} W/m2 of red light, standard error {error:.2f}")
print(f"points: error {table.estimated_error:.2g}, surely below {table.error_bound:.2g}; "
      f"picture: {picture.estimated_error:.2g}, {picture.error_bound:.2g}")
