## Texts of the pickers of values.

window-pickers-choose = Choose…
window-pickers-filter = Type to find a value
window-pickers-none = No value fits “{ $text }”.
window-pickers-enter = Enter picks { $value }
window-pickers-tip =
    { $value }
    Arrow keys walk, Enter picks, Ctrl and a click shows its details
window-pickers-on-body = On the body
window-pickers-in-space = In space
window-pickers-from-front = From the front
window-pickers-from-side = From the side
window-pickers-head = Head
window-pickers-trunk = Body
window-pickers-weak-hand = Weak hand
window-pickers-space-front = As the addressee sees it
window-pickers-space-side = From the side
window-pickers-near = Near
window-pickers-reach = Middle
window-pickers-far = Far
window-pickers-point-at = Point at a place
window-pickers-zone = { $value }, on the picture
window-pickers-away = Away
window-pickers-level = Across
window-pickers-towards = Towards
window-pickers-as-signer = As the signer sees it
window-pickers-drawing = The body is being drawn…
