"""The fields of a scenario: printed, as a JSON schema, and written with comments."""
