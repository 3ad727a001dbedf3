"""The page in the browser: a face of the commands, with no calculation of its own."""
