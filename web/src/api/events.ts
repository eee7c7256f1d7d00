// A job's way, as the server tells it.

import type { JobState } from './types.ts';

interface JobWatcher {
  onState(state: JobState): unknown;
  // The stream broke. The browser tries again by itself, unless the server has said that there is no such job.
  onBreak(): unknown;
}

export function isOver(job: JobState): boolean {
  return job.state === 'done' || job.state === 'failed';
}

const waitWhereRefused_ms = 2000;

// Calls back until the job is over, or until the returned function is called.
export function watchJob(events: string, watcher: JobWatcher): () => void {
  let source: EventSource;
  let again: ReturnType<typeof setTimeout> | undefined;
  let ended = false;
  const end = (): void => {
    ended = true;
    clearTimeout(again);
    source.close();
  };
  const open = (): void => {
    source = new EventSource(events);
    source.addEventListener('state', (event) => {
      const state = JSON.parse((event as MessageEvent<string>).data) as JobState;
      // Else the browser takes the end of the stream for a break and asks again.
      if (isOver(state)) end();
      watcher.onState(state);
    });
    source.addEventListener('error', () => {
      watcher.onBreak();
      // Refused, because many others listen; the browser does not ask again then. Whoever knows that the job is gone ends it.
      if (!ended && source.readyState === EventSource.CLOSED) again = setTimeout(open, waitWhereRefused_ms);
    });
  };
  open();
  return end;
}
