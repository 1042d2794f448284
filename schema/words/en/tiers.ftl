## Roles of tiers.

tier-role-gloss = gloss
tier-role-component = component
tier-role-translation = translation
tier-role-comment = comment
tier-role-free = anything
tier-role-help = The subject of its annotations: { $roles }, or a component such as right.placement or nonmanual.brows; the word before the dot is their hand
