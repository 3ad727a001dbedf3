"""Parameter studies: extremes and means of results against varied inputs."""
