"""The closed loops: stations of the data flow and the tasks made of them."""
