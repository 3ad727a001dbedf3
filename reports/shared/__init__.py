"""What every room needs: errors, files, progress, the machine."""
