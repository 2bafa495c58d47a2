"""From footsteps to motions of CoM, feet and waist, quasi-static ones included."""
