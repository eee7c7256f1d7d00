// Where the lamps stand, from what several faces saw of them.

import { addressOf } from '../api/client.ts';
import type { DoneEstimate, Lamp, Room } from '../api/types.ts';
import { anglesOf } from '../light/radiance_map.ts';
import { directionInWords, placeInWords } from '../light/words.ts';
import { metres } from './format.ts';
import { LightColour } from './parts/LightColour.tsx';

export function RoomPanel({ estimate, room }: { estimate: DoneEstimate; room: Room }) {
  return (
    <section class="card room" aria-labelledby="room-title">
      <h2 id="room-title">Room</h2>
      <img
        src={addressOf.file(estimate.id, 'room.png')}
        alt="The room from above and from the right: camera, faces, and the lamps they saw"
      />
      {room.lamps.length === 0 ? (
        <p>No lamp was seen by two faces at once, so none has a place.</p>
      ) : (
        <table class="lights">
          <caption>Lamps</caption>
          <thead>
            <tr>
              <th scope="col">
                <abbr title="Number">No.</abbr>
              </th>
              <th scope="col">Place</th>
              <th scope="col">Colour</th>
              <th scope="col" class="number">
                Strength
              </th>
              <th scope="col">Faces</th>
            </tr>
          </thead>
          <tbody>
            {room.lamps.map((lamp, index) => (
              <tr key={index}>
                <th scope="row">
                  <span class="light-number">{index + 1}</span>
                </th>
                <td>{placeOf(lamp)}</td>
                <LightColour rgb={lamp.colour_rgb} />
                <td class="number">{(lamp.intensity ?? lamp.irradiance ?? 0).toFixed(2)}</td>
                <td>{lamp.seen_by.map(({ face }) => face).join(', ')}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}

function placeOf(lamp: Lamp) {
  if (!lamp.position_m) {
    const [azimuth, elevation] = anglesOf(lamp.direction);
    return `Far away: ${directionInWords(azimuth, elevation).toLowerCase()}`;
  }
  return (
    <>
      {placeInWords(lamp.position_m)}
      {lamp.position_deviation_m !== undefined && (
        <span class="fine"> give or take {metres(lamp.position_deviation_m)}</span>
      )}
    </>
  );
}
