# Le nom que la langue se donne, pour le choix des langues.
language-name = Français
