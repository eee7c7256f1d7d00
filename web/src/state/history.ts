// The estimates that the server still has.

import { useCallback, useEffect, useState } from 'preact/hooks';

import { deleteEstimate, listEstimates } from '../api/client.ts';
import { sentenceOf } from '../api/failure.ts';
import type { EstimateSummary } from '../api/types.ts';

export interface History {
  entries: EstimateSummary[];
  trouble?: string;
  refresh(): void;
  remove(id: string): Promise<boolean>; // whether it is gone
}

export function useHistory(): History {
  const [state, setState] = useState<{ entries: EstimateSummary[]; trouble?: string }>({ entries: [] });
  const fail = (error: unknown) => setState(({ entries }) => ({ entries, trouble: sentenceOf(error) }));
  const refresh = useCallback(() => {
    listEstimates().then((entries) => setState({ entries }), fail);
  }, []);
  const remove = useCallback(async (id: string) => {
    try {
      await deleteEstimate(id);
      setState(({ entries }) => ({ entries: entries.filter((entry) => entry.id !== id) }));
      return true;
    } catch (error) {
      fail(error);
      return false;
    }
  }, []);
  useEffect(refresh, []);
  return { ...state, refresh, remove };
}
