"""Benchmarks: ``./run bench [NAME…]`` prints times, ratios and memory; no test depends on them."""
