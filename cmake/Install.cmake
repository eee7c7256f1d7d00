# placeholder, filled with the package export
