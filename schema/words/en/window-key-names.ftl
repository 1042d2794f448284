## Names of keys, as keyboards have them.

window-key-names-ctrl = Ctrl
window-key-names-shift = Shift
window-key-names-alt = Alt
window-key-names-space = Space
window-key-names-enter = Enter
window-key-names-tab = Tab
window-key-names-escape = Escape
window-key-names-backspace = Backspace
window-key-names-delete = Delete
window-key-names-insert = Insert
window-key-names-home = Home
window-key-names-end = End
window-key-names-page-up = PageUp
window-key-names-page-down = PageDown
window-key-names-left = Left
window-key-names-right = Right
window-key-names-up = Up
window-key-names-down = Down
