// How far a job is.

import type { JobState } from '../../api/types.ts';
import { seconds } from '../format.ts';

export function JobProgress({ job, label }: { job: JobState | undefined; label: string }) {
  const stage = stageOf(job);
  return (
    <div class="progress">
      {/* Only the stage is read out; times change too often. */}
      <p role="status">{stage}</p>
      <p class="progress-time">{timeOf(job)}</p>
      {job?.share === undefined ? (
        <progress aria-label={label} />
      ) : (
        <progress aria-label={label} max={1} value={job.share} />
      )}
    </div>
  );
}

function stageOf(job: JobState | undefined): string {
  if (!job) return 'Asking the server';
  if (job.state === 'waiting') return 'Waiting for its turn';
  return job.stage ?? 'Working';
}

function timeOf(job: JobState | undefined): string {
  if (job?.seconds_left !== undefined) return `about ${seconds(job.seconds_left)} left`;
  return job ? seconds(job.elapsed_seconds) : '';
}
