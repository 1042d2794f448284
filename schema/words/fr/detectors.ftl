## What detectors find, and why they propose it.

detector-signs-peeled = seul signe entre deux repos, de la main { $side }
detector-signs-peeled-by-both = seul signe entre deux repos, des deux mains ; la main { $side } mène
detector-signs-decoded = un de plusieurs signes entre deux repos, de la main { $side }
detector-signs-decoded-by-both = un de plusieurs signes entre deux repos, des deux mains ; la main { $side } mène
detector-signs-phase = partie du signe que fait cette main
detector-signs-finds = signes, et préparation, noyau, tenue et rétraction de chaque main
detector-nonmanuals-finds = actions des sourcils, des paupières, du regard, de la bouche et de la tête, d’après les courbes du visage
detector-nonmanuals-shorter = { $peak } au-dessus de la médiane ; { $threshold } suffit, pendant moins de { $time } s
detector-nonmanuals-above = { $peak } au-dessus de la médiane ; { $threshold } suffit
detector-nonmanuals-swings = { $count } demi-balancements de { $mean } degrés ; { $fewest } de { $least } suffisent
