// The photos of this session: to come back to, or to remove.

import { addressOf } from '../api/client.ts';
import { hasPhoto, type EstimateSummary } from '../api/types.ts';
import type { History } from '../state/history.ts';
import type { Intake } from '../state/intake.ts';
import { Alert } from './parts/Alert.tsx';

interface Props {
  history: History;
  intake: Intake;
  shown: string | null;
  onPick(id: string): void;
  onRemoved(id: string): void;
}

export function HistoryStrip({ history, intake, shown, onPick, onRemoved }: Props) {
  if (history.entries.length === 0 && !history.trouble) return null;
  return (
    <section class="history" aria-labelledby="history-title">
      <h2 id="history-title">Photos of this session</h2>
      <Alert sentence={history.trouble} />
      <ul class="thumbs">
        {history.entries.map((entry) => (
          <li key={entry.id}>
            <button
              type="button"
              class="thumb"
              aria-current={entry.id === shown ? 'true' : undefined}
              onClick={() => onPick(entry.id)}
            >
              <Thumbnail entry={entry} intake={intake} />
              <span>{entry.name}</span> <span class="fine">{summaryOf(entry)}</span>
            </button>
            <button
              type="button"
              class="thumb-remove"
              aria-label={`Remove ${entry.name}`}
              title="Remove"
              onClick={() => void history.remove(entry.id).then((gone) => gone && onRemoved(entry.id))}
            >
              <span aria-hidden="true">×</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

function Thumbnail({ entry, intake }: { entry: EstimateSummary; intake: Intake }) {
  const source = hasPhoto(entry.job) ? addressOf.photo(entry.id) : intake.previewOf(entry.id);
  return source === undefined ? <span class="no-thumb" /> : <img src={source} alt="" />;
}

function summaryOf({ job, faces }: EstimateSummary): string {
  if (job.state === 'failed') return job.error?.kind === 'no_face' ? 'no face' : 'failed';
  if (job.state !== 'done') return 'at work';
  return faces === 1 ? '1 face' : `${faces ?? 0} faces`;
}
