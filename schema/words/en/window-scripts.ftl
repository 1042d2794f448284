## Texts about writing systems, and about letters without a font.

window-scripts-no-font = No font of this computer has letters for: { $scripts }. They are shown by their numbers.
window-scripts-no-font-help = Install a font for it, such as Noto (on Debian: fonts-noto), and open the window again.
window-scripts-arabic = Arabic
window-scripts-armenian = Armenian
window-scripts-bengali = Bengali
window-scripts-chinese = Chinese
window-scripts-cyrillic = Cyrillic
window-scripts-devanagari = Devanagari
window-scripts-ethiopic = Ethiopic
window-scripts-georgian = Georgian
window-scripts-greek = Greek
window-scripts-hebrew = Hebrew
window-scripts-japanese = Japanese
window-scripts-korean = Korean
window-scripts-tamil = Tamil
window-scripts-thai = Thai
