"""An independent truth: laws as differential equations, integrated to ten digits. Shares no code with the project."""
