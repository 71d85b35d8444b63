"""Networks as Modelica.

code  - statements of Modelica functions
model - the model around them, with the flanges of the standard library
"""
