"""Tables of balance, reduced inertia, torque orders and firing orders."""
