"""Plots, pictures, comparison and measured results of what tanktread writes.

Run as `python3 -m tanktread_post COMMAND`, with post/ in PYTHONPATH and Debian's Python (numpy, matplotlib, meshio, VTK).
"""
