#!/usr/bin/python3
"""The reference of the case: energy, tension and pressure of the three branches by the shape equations.
PYTHONPATH=post /usr/bin/python3 cases/vesicle/theory.py >cases/vesicle/reference/energies.csv"""

from tanktread_post.vesicle_shapes import shape

SPANS = {"oblate": (51, 98), "prolate": (51, 98), "stomatocyte": (42, 65)}  # hundredths of reduced volume, both ends in

if __name__ == "__main__":
    print("# Vesicles of least bending energy by the axisymmetric shape equations (post/tanktread_post/vesicle_shapes.py), made by")
    print("# PYTHONPATH=post /usr/bin/python3 cases/vesicle/theory.py >cases/vesicle/reference/energies.csv")
    print("# energy over 8 pi kappa_b; tension and pressure (outside less inside) in kappa_b over square and cube of the radius of the sphere of equal area")
    print("branch,reduced_volume,energy,tension,pressure")
    for branch, (first, last) in SPANS.items():
        for hundredths in range(first, last + 1):
            found = shape(branch, hundredths / 100)
            print(f"{branch},{hundredths / 100:.2f},{found.energy:.8f},{found.tension:.6f},{found.pressure:.6f}", flush=True)
