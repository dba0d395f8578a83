// How far a picture is from the interpreter's.

/**
 * Differences between values, after both are rounded to what `bits` hold: of 8 bits, up to half a level is the engine's rounding.
 * `within` is the share of values that differ by no more than the bound.
 */
export function compare(rgba, reference, bits, bound) {
    if (rgba.length !== reference.length) throw new Error(`${rgba.length} values instead of ${reference.length}`);
    const limit = bits === 8 ? 0.5 / 255 + bound : bound;
    let most = 0;
    let within = 0;
    let compared = 0;
    for (let k = 0; k < rgba.length; k++) {
        // Pictures of 8 bits go through formats without alpha.
        if (bits === 8 && k % 4 === 3) continue;
        const expected = bits === 8 ? Math.min(Math.max(reference[k], 0), 1) : reference[k];
        const difference = Math.abs(rgba[k] - expected);
        // A NaN is as far off as anything.
        const off = Number.isNaN(difference) ? Infinity : difference;
        most = Math.max(most, off);
        compared += 1;
        if (off <= limit) within += 1;
    }
    return { most, within: within / compared, limit };
}
