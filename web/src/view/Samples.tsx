import { addressOf } from '../api/client.ts';
import type { Info } from '../api/types.ts';
import type { Intake } from '../state/intake.ts';

export function Samples({ samples, intake }: { samples: Info['samples']; intake: Intake }) {
  if (samples.length === 0) return null;
  return (
    <section class="samples" aria-labelledby="samples-title">
      <h2 id="samples-title">Or try a sample</h2>
      <ul class="thumbs">
        {samples.map(({ name, title }) => (
          <li key={name}>
            <button
              type="button"
              class="thumb"
              disabled={intake.busy}
              onClick={() => void intake.takeSample(name, title)}
            >
              <img src={addressOf.sample(name)} alt="" />
              <span>{title}</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
