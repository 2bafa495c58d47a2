"""The scenarios that ship with footfall, one YAML file each."""
