"""Many books at once, in workers."""
