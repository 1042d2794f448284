## Texts about writing systems, and about letters without a font.

window-scripts-no-font = Aucune police de cet ordinateur n’a de lettres pour : { $scripts }. Elles sont montrées par leurs numéros.
window-scripts-no-font-help = Installez une police pour cela, comme Noto (sous Debian : fonts-noto), et rouvrez la fenêtre.
window-scripts-arabic = arabe
window-scripts-armenian = arménien
window-scripts-bengali = bengali
window-scripts-chinese = chinois
window-scripts-cyrillic = cyrillique
window-scripts-devanagari = devanagari
window-scripts-ethiopic = éthiopien
window-scripts-georgian = géorgien
window-scripts-greek = grec
window-scripts-hebrew = hébreu
window-scripts-japanese = japonais
window-scripts-korean = coréen
window-scripts-tamil = tamoul
window-scripts-thai = thaï
