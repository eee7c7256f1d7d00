import type { MainLight } from '../api/types.ts';
import { directionInWords } from '../light/words.ts';
import { degrees, percent } from './format.ts';
import { LightColour } from './parts/LightColour.tsx';

export function LightsTable({ lights }: { lights: MainLight[] }) {
  if (lights.length === 0) return <p>No single light stands out: it comes from all around.</p>;
  return (
    <table class="lights">
      <caption>Main lights</caption>
      <thead>
        <tr>
          <th scope="col">
            <abbr title="Number">No.</abbr>
          </th>
          <th scope="col">Direction</th>
          <th scope="col">Colour</th>
          <th scope="col" class="number">
            Strength
          </th>
          <th scope="col" class="number">
            Share
          </th>
        </tr>
      </thead>
      <tbody>
        {lights.map((light, index) => (
          <tr key={index}>
            <th scope="row">
              <span class="light-number">{index + 1}</span>
            </th>
            <td>
              {directionInWords(light.azimuth_deg, light.elevation_deg)}
              <span class="fine">
                {' '}
                azimuth {degrees(light.azimuth_deg)}, elevation {degrees(light.elevation_deg)}
              </span>
            </td>
            <LightColour rgb={light.colour_rgb} />
            <td class="number">{light.irradiance.toFixed(2)}</td>
            <td class="number">{percent(light.share_of_energy)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
