"""The rheological schematic of a network: laid out once, drawn as SVG or with characters."""
