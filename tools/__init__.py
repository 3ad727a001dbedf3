"""Tools of the checkout that the wheel does not carry."""
