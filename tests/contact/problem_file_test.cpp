// A contact problem survives the file, bit for bit; files that are not one are refused with their name.
#include "problems.hpp"
#include <contact/problem_file.hpp>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace nonsmooth::contact;
using namespace nonsmooth::contact::testing;

namespace {

class ProblemFile : public ::testing::Test {
protected:
	// one a test: ctest runs several at a time
	std::filesystem::path folder = std::filesystem::path(::testing::TempDir())
	        / (std::string("nonsmooth_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + std::to_string(getpid()));
	std::string           path   = (folder / "step.h5").string();

	void SetUp() override { std::filesystem::create_directories(folder); }
	void TearDown() override { std::filesystem::remove_all(folder); }

	/// What reading the file complains about.
	std::string complaint() const
	{
		try {
			read(path);
		} catch (const std::runtime_error& error) {
			return error.what();
		}
		return "";
	}
};

TEST_F(ProblemFile, KeepsEveryBit)
{
	RecordedProblem out { lattice(12, 5).problem, {}, step };
	out.warmStart = out.problem.impulses;
	SolverSettings s;
	s.tolerance = 1e-8;
	solve(out.problem, s);
	write(path, out);
	const RecordedProblem in = read(path);
	EXPECT_EQ(in.timeStep, step);
	EXPECT_TRUE(sameBits(in.warmStart, out.warmStart));
	EXPECT_TRUE(sameBits(in.problem.impulses, out.problem.impulses));
	EXPECT_TRUE(sameBits(in.problem.velocities, out.problem.velocities));
	EXPECT_TRUE(sameBits(in.problem.freeVelocity, out.problem.freeVelocity));
	EXPECT_TRUE(sameBits(in.problem.inverseMass, out.problem.inverseMass));
	EXPECT_TRUE(sameBits(in.problem.positions, out.problem.positions));
	ASSERT_EQ(in.problem.contactCount(), out.problem.contactCount());

	// and so a solve of what was read gives the same bits
	Problem again  = in.problem;
	again.impulses = in.warmStart;
	solve(again, s);
	EXPECT_TRUE(sameBits(again.impulses, out.problem.impulses));
	EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST_F(ProblemFile, AnEmptyProblemIsOneToo)
{
	write(path, {});
	EXPECT_EQ(read(path).problem.contactCount(), 0u);
}

TEST_F(ProblemFile, RefusesWhatIsNotOne)
{
	EXPECT_NE(complaint().find("cannot be opened"), std::string::npos) << complaint();
	std::ofstream(path) << "no HDF5";
	EXPECT_NE(complaint().find(path), std::string::npos) << complaint();

	RecordedProblem out { lattice(4, 2).problem, {}, step };
	out.problem.velocities.resize(out.problem.bodyCount());
	out.warmStart.resize(3); // too short
	write(path, out);
	EXPECT_NE(complaint().find("warm_start has 3 rows"), std::string::npos) << complaint();
	std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
	EXPECT_NE(complaint().find(path), std::string::npos) << complaint();
}

TEST_F(ProblemFile, SaysWhereItCannotWrite)
{
	try {
		write((folder / "nowhere" / "step.h5").string(), {});
		FAIL() << "it was written";
	} catch (const std::runtime_error& error) {
		EXPECT_NE(std::string(error.what()).find("cannot be created"), std::string::npos) << error.what();
	}
}

} // namespace
