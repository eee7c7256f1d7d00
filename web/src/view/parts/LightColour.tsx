import type { Vec3 } from '../../light/vector.ts';
import { swatchOf, warmthInWords } from '../../light/words.ts';

// As a cell of a table.
export function LightColour({ rgb }: { rgb: Vec3 }) {
  return (
    <td class="colour">
      <span class="swatch" style={{ background: swatchOf(rgb) }} aria-hidden="true" />
      {warmthInWords(rgb)}
    </td>
  );
}
