/** What became of one test, by the report of the tool that ran it. */
export interface Outcome {
  /** Path of its file, relative to the repository's root. */
  file: string;
  /** Its name and those of the suites around it, separated by ` > `; empty for a file that could not be loaded. */
  title: string;
  status: 'passed' | 'failed' | 'skipped';
  ms: number;
  /** Of a failure: what was expected and what was there; otherwise empty. */
  reason: string;
  /** Where it begins, if the report says so. */
  line: number | null;
  /** What it left behind: pictures, traces, logs. */
  attachments: readonly string[];
}

/** How a test is named in a list, in the quarantine, and on a command line. */
export function nameOf({ file, title }: Pick<Outcome, 'file' | 'title'>): string {
  return title === '' ? file : `${file} > ${title}`;
}
