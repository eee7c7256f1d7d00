// A job's way, as the server tells it.

import type { JobState } from './types.ts';

export interface JobWatcher {
  onState(state: JobState): unknown;
  // The stream broke. The browser tries again by itself, unless the server has said that there is no such job.
  onBreak(): unknown;
}

export function isOver(job: JobState): boolean {
  return job.state === 'done' || job.state === 'failed';
}

// Calls back until the job is over, or until the returned function is called.
export function watchJob(events: string, watcher: JobWatcher): () => void {
  const source = new EventSource(events);
  source.addEventListener('state', (event) => {
    const state = JSON.parse((event as MessageEvent<string>).data) as JobState;
    // Else the browser takes the end of the stream for a break and asks again.
    if (isOver(state)) source.close();
    watcher.onState(state);
  });
  source.addEventListener('error', () => void watcher.onBreak());
  return () => source.close();
}
