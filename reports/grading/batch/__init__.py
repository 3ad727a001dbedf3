"""Many books at once: in workers, on a cluster, taken up where it stopped."""
