#pragma once

/// Which sanitizer is built in: tests use it to skip what the sanitizer itself changes: memory, time, how a process
/// ends.
namespace sprung::test {

#if defined(__has_feature)
#define SPRUNG_HAS_FEATURE(feature) __has_feature(feature)
#else
#define SPRUNG_HAS_FEATURE(feature) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || SPRUNG_HAS_FEATURE(address_sanitizer)
inline constexpr bool kAddressSanitized = true;
#else
inline constexpr bool kAddressSanitized = false;
#endif

#if defined(__SANITIZE_THREAD__) || SPRUNG_HAS_FEATURE(thread_sanitizer)
inline constexpr bool kThreadSanitized = true;
#else
inline constexpr bool kThreadSanitized = false;
#endif

inline constexpr bool kSanitized = kAddressSanitized || kThreadSanitized;

#undef SPRUNG_HAS_FEATURE

}  // namespace sprung::test
