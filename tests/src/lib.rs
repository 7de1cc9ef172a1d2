//! Shared helpers of the verification cases.
