/** What describes a series to people. */
export interface SeriesDescription {
  /** Identifies it among the robot's, in every session. */
  readonly key: string;
  readonly label: string;
  readonly unit: string;
}
