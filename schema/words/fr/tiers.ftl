## Roles of tiers.

tier-role-gloss = glose
tier-role-component = composant
tier-role-translation = traduction
tier-role-comment = commentaire
tier-role-free = autre
tier-role-help = L’objet de ses annotations : { $roles }, ou un composant comme right.placement ou nonmanual.brows ; le mot avant le point est leur main
