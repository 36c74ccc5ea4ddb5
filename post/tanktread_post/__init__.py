"""Plots, pictures and comparison of what tanktread writes. Run as `python3 -m tanktread_post COMMAND`."""
